; check: exit 1
; error 21024 at 3:11
G02 X9 I5 R5 F1000
M30
