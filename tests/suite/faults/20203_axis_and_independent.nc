; check: exit 1
; error 20203 at 3:9
G00 Y5 Y[INDP_SYN G90 G00 POS=10]
M30
