// Planted faults of the BSDFs' harness kernels: 1 leaves the code as it is.
layout(constant_id = 40) const float kRadianceFault = 1.0; // factor of f
layout(constant_id = 41) const float kPdfFault = 1.0;      // factor of the density
layout(constant_id = 42) const float kAlphaFault = 1.0;    // factor of alpha, in sampling alone
layout(constant_id = 43) const float kLobeFault = 1.0;     // factor of the first lobe's probability, in sampling alone
