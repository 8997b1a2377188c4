; check: exit 1
; page 1020922507 diagnosis 22180, wrong
; error 22180 at 4:14
N10 G132 X70 G133 = 100
N1000 M30
