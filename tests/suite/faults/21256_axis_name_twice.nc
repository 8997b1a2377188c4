; check: exit 1
; error 21256 at 3:18
#SET AX [X,1,0] [X,2,1]
M30
