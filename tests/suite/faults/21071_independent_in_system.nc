; check: exit 1
; error 21071 at 4:2
#CS ON [1,2,3,0,0,30]
X[INDP_SYN G90 G01 FEED=1000 POS=5]
M30
