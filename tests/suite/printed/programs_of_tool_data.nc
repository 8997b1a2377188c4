; run --set channel.d_prog_file=called/tool_data.nc: exit 0
; page 405038859 channel parameters, P-CHAN-00429, programs of D words
; end X127 Y128
V.G.WZ[127].OK=1 V.G.WZ[128].OK=1
G01 F6000
N10 D127
N20 #FILE NAME [D="called/tool_data_two.nc"]
N30 D128
M30
