; check: exit 1
; error 20751 at 3:7
#TIME -1
M30
