; check: exit 1
; error 20535 at 4:1
G63 Z10 F1000 S100
#SET AX [X,1,0]
M30
