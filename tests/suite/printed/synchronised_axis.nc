; check: exit 1
; page 265394571 diagnosis 120678, axis synchronised with the path (SYNC IN, SYNC OUT)
; error K-0019 at 6:17
; error K-0019 at 8:14
N10 G01 F1000 X20
N130 X=39.819 Z[SYNC IN G01 POS=130 DIST=70]
N140 X=1.257
N160 X=200 Z[SYNC OUT G91 G0 POS160]
M30
