; check: exit 1
; page 251037323 diagnosis 20187, wrong
; error 20187 at 5:5
N10 G00 X0 Y0 Z0
N20 R-1=10
N50 G02 F1000
N60 M30
