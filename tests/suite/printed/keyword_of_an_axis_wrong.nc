; check: exit 1
; page 254122891 diagnosis 21301, wrong
; error 21301 at 4:7
N10 X[POS=10 INDP_SYN G90 G00]
N20 M30
