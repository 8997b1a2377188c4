; check: exit 1
; page 264767883 diagnosis 120470, wrong
; error 120470 at 5:25
%osc
N10 X[OSC_ON 1ST_POS=50 2ND_POS=50 FEED=1000]
N20 M30
