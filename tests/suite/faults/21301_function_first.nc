; run: exit 1
; error 21301 at 3:3
X[POS=10 INDP_SYN G90 G00]
M30
