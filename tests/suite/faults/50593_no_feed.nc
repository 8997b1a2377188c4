; check: exit 1
; error 50593 at 3:2
X[OSC ON 1ST_POS=-10 2ND_POS=10]
M30
