; check: exit 0
; warning K-0109 at 3:2
X[INDP_SYN G90 G01 TIME=0.01 POS=300]
M30
