; run: exit 1
; error 20207 at 3:1
G04 1 #SCALE OFF
M30
