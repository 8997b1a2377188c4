; check: exit 1
; error 21068 at 3:2
X[INDP_SYN G90 FEED=1000 POS=10]
M30
