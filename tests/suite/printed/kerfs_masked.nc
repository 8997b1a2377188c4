; check: exit 1
; page 1230481547 masking of kerfs (KERF_MASKING)
; error K-0019 at 4:11
N10 #TRC [KERF_MASKING=1]
N20 M30
