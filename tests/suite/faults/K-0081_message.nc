; run: exit 0
; note K-0081 at 3:1
#MSG ["hello"]
M30
