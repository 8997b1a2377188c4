; check: exit 1
; error 21507 at 3:23
#CHANNEL INIT [CMDPOS CMDPOS]
M30
