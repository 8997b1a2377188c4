; check: exit 1
; page 1020935563 diagnosis 22182, wrong
; error 22182 at 4:14
N10 G127 X70 G128 = 100
N1000 M30
