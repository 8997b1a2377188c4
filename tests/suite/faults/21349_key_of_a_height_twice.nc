; check: exit 1
; error 21349 at 3:19
#TGC ON [OPMODE=1 OPMODE=2]
M30
