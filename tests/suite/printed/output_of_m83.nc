; run --set channel.m_synch[83]=0x1: exit 0
; page 286205579 M function to the channel or to an axis
; end X0 Y0 Z0
N10 M83 X[M83]
N20 M83
N30 X[M83]
N40 M30
