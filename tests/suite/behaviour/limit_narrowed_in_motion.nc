; run: exit 0
; end X0
G01 X100 F60000
X50
(the axis still lags beyond the limit when the next block begins)
G99 X60
X0
M30
