; check --set Y.kenngr.messachse=0: exit 1
; error 50059 at 3:10
G100 X10 Y10 F500
M30
