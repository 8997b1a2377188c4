; check --identity-trafo: exit 0
; warning K-0111 at 6:1
; warning K-0111 at 7:1
; warning K-0111 at 8:1
G71
V.G.KIN[9].PARAM[0]=1000
#KIN ID[9]
#PTP ON
G01 X[V.G.KIN[9].PARAM[0]/100] F1000
#PTP OFF
M30
