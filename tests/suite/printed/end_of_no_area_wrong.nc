; run: exit 0
; page 254066315 diagnosis 21288, wrong: the command is ignored
; end X20 Y20
; warning 21288 at 7:5
N20 G01 X10 Y10 F1000
N30 G01 X20 Y20
N40 #CONTROL AREA END
N50 M30
