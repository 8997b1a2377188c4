; check: exit 1
; error 21236 at 4:1
#CS ON [10, 0, 0, 0, 0, 0]
#WCS TO MCS [X=1]
M30
