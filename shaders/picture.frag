#version 330 core
// A picture over all of the viewport (picture.vert), filtered as its texture says.

uniform sampler2D picture;

in vec2 place;

out vec4 color;

void main() {
    color = texture(picture, place);
}
