; check: exit 1
; error 20020 at 3:5
G02 I94967596 F1000
M30
