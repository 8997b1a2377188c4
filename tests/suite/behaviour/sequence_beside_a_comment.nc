; run: exit 0
; end X2
(a number inside a comment is text)
G91 G01 F1000
#COMMENT BEGIN
N10 X100
#COMMENT END
N10 X1
L SEQUENCE [N10]
M30
