; check: exit 0
; warning 21288 at 4:1
G01 X10 Y10 F1000
#CONTROL AREA END
M30
