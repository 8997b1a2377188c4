; run: exit 0
; page 264767883 diagnosis 120470, right
; passes X-100
; end X100
%osc
N10 X[OSC_ON 1ST_POS=-100 2ND_POS=100 FEED=10000]
N20 M30
