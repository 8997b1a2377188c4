; run: exit 1
; error 20676 at 3:22
#CS ON [10,20,0,45,0,450]
M30
