; run: exit 1
; error K-0009 at 3:38
L CYCLE [NAME="called/unpassed.nc"   @P201=1]
M30
