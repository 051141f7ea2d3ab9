// Nothing lets light straight on through. What shadow rays need of either kind of scene:
WORDS_WRITE(3, visibility);

const uint kShadowingHit = kAnyHit; // with which they end

bool passes(uint slot, inout Traversal ray) { return false; }

void storeVisibility(uint slot, Traversal ray) { storeWord(visibility, slot, ray.primitive == kNoPrimitive ? 1u : 0u); }
