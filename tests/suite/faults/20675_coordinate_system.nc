; check: exit 1
; error 20675 at 3:8
#CS ON [1,2,3,4,5,6,7]
M30
