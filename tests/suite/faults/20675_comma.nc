; check: exit 1
; error 20675 at 3:8
#CS ON [10,20,0,0,0 45]
M30
