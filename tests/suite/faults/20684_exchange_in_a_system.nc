; check: exit 1
; error 20684 at 4:1
#CS ON [10,20,0,0,0,45]
#PUT AX [X]
M30
