; check: exit 1
; error 21338 at 3:16
#COLL ON [ID=1 ID=2]
M30
