; run: exit 1
; error 20207 at 4:1
F600
Y5 #SCALE ON X2
M30
