; check: exit 1
; error K-0019 at 4:1
; error K-0019 at 5:1
V.G.KIN[9].PARAM[0]=1000
#PTP ON
M30
