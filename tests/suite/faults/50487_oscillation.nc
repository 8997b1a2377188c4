; check: exit 0
; warning 50487 at 3:2
X[OSC ON 1ST_POS=-120 2ND_POS=120 FREQ=5]
X[OSC OFF]
M30
