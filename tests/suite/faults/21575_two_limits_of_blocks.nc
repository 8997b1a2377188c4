; check: exit 1
; warning K-0111 at 4:1
; error 21575 at 5:1
V.G.MAX_NC_BLOCKS_AHEAD = 10
V.G.MAX_MOTION_BLOCKS_AHEAD = 5
M30
