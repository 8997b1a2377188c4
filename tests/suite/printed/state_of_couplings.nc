; run: exit 0
; page 207139467 coupling group in force (V.G.AX_LINK)
; note K-0081 at 8:1
; note K-0081 at 10:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [2, C=X]
#ENABLE AX LINK [2]
#MSG ["%d %d", V.G.AX_LINK.NR, V.G.AX_LINK.ACTIVE]
#DISABLE AX LINK [2]
#MSG ["%d %d", V.G.AX_LINK.NR, V.G.AX_LINK.ACTIVE]
M30
