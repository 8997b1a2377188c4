; check: exit 1
; error K-0150 at 4:1
Z[OSC ON 1ST_POS=1 2ND_POS=2 FEED=1000]
#CS ON [0,0,0,0,0,30]
M30
