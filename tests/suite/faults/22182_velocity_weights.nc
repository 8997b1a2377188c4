; run: exit 1
; error 22182 at 3:10
G127 X70 G128=100
M30
