; run: exit 1
; error 22180 at 3:10
G132 X70 G133=100
M30
