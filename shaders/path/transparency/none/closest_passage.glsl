// Nothing lets light straight on through. What path rays need of either kind of scene:

// Whether a ray that has ended passes what it has hit, and goes on.
bool passes(uint slot, inout Traversal ray) { return false; }
