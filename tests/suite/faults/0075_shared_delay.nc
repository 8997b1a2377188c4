; check --set X.vorsteuer.feedforward_without_delay=1: exit 0
; warning K-0075 at --set 1:1
N10 G135
N20 G01 X1 Y1 F1000
N30 M30
