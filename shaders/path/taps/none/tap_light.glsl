// Nobody listens to the light that paths meet. What any tap provides here (TAP_BINDING is its first binding):

// Light that arrives at the path's last vertex: emission that its ray has met, weighted against light sampling; the share
// of the light sample in flight that nothing has stopped.
void hearEmission(uint path, vec3 emitted) {}
void hearDirectLight(uint path, vec3 share) {}
