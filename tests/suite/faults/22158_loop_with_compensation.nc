; check: exit 1
; warning K-0114 at 4:1
; error 22158 at 5:1
G41 G01 X5 F500
#RT WHILE
M30
