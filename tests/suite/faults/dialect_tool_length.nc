; check: exit 1
; error 20131 at 4:1
; once per program
G43 H1 Z10 F100
X1
G43 H2 Z5
M30
