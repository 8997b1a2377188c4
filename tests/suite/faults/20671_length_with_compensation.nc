; run: exit 1
; error 20671 at 5:1
V.G.WZR=1
G41
#TLC ON [25]
G40
M30
