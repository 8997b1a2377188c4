; check: exit 1
; error 21274 at 4:15
#SAVE CONFIG [AXLINK]
#LOAD CONFIG [AX]
M30
