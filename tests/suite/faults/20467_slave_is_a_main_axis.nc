; check: exit 1
; error 20467 at 4:1
#SET AX LINK [1, Y=X]
#ENABLE AX LINK [1]
M30
