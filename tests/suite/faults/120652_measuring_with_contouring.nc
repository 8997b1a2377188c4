; check --set X.kenngr.messachse=1: exit 1
; error 120652 at 5:1
G01 Z10 F1000
G261
G100 X100
G260
M30
