; run: exit 0
; end X22 Y2 Z2
(the blocks from one number to another, the last one included, and a single one)
G91 F1000
N10 G01 X1
N20 Y1
/N30 Z1
N40 X10
L SEQUENCE [N10 N30]
L SEQUENCE [N40]
M30
