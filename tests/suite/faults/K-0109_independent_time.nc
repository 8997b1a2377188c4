; check: exit 0
; warning K-0109 at 5:2
; warning K-0109 at 6:2
; 300 mm at 1000 mm/s in 0.01 s; in 0.31 s, which the speed would permit but not the acceleration; in 2 s
X[INDP_SYN G90 G01 TIME=0.01 POS=300]
X[INDP_SYN G90 G01 TIME=0.31 POS=0]
X[INDP_SYN G90 G01 TIME=2 POS=300]
M30
