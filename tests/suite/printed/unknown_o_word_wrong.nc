; check: exit 1
; page 251050379 diagnosis 20192, wrong
; error 20192 at 4:5
N10 O5
M30
