; check: exit 1
; error K-0137 at 3:1
#ENABLE AX LINK [2]
M30
