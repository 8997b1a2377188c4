; run: exit 1
; error K-0009 at 4:38
; warning K-0109 at called/unpassed.nc 1:2
L CYCLE [NAME="called/unpassed.nc"   @P201=1]
M30
