; check: exit 1
; error 20820 at 3:9
#CS ON [0][1,2,3]
M30
