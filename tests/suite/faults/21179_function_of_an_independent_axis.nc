; check --set channel.m_default_outp_ax_name[31]=X: exit 1
; error 21179 at 4:1
M31 Y[INDP_SYN G90 G01 FEED=100 POS=10]
M31 X[INDP_SYN G90 G01 FEED=100 POS=10]
M30
