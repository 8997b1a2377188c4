; run: exit 0
; page 1069167755 suppressed compensation (SUPPRESS_TRC)
N10 #TRC [SUPPRESS_TRC=1]
N20 M30
