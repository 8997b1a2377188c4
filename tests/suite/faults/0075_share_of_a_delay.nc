; run --set X.filter_fir.type=4 --set X.filter_fir.order=10: exit 0
; note K-0075 at 4:1
; warning K-0112 at 4:1
#FILTER ON [SHARE=30]
G01 X1 F1000
M30
