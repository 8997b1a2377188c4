; check: exit 1
; error 20863 at 3:13
#TOOL DATA [-1, 0, 0]
M30
