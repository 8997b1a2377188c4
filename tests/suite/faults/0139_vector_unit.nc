; check: exit 0
; warning K-0139 at 4:19
%P
#VECTOR LIMIT ON [ACC=500]
G01 X1 F1000
M30
