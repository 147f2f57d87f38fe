/** Pictures of scenes from above, and what stands where there is none. */

import { element } from "../shared/dom.js";
import { icon } from "../shared/icons.js";
import { t } from "../shared/text.js";

/**
 * Return a frame with a scene's picture, which is loaded when it comes into view. If the picture is
 * missing or can't be loaded, the frame has an icon.
 * @param {string} address of the picture; empty if there is none
 * @param {string} title of the scene
 */
export function scenePicture(address, title) {
  const frame = element("span", { className: "ai4u-scene-picture" });
  const showNone = () => frame.replaceChildren(icon("picture", 40));
  if (address) {
    // `loading` comes first: some browsers load as soon as there is an address
    const image = element("img", { loading: "lazy", alt: t("{title} from above", { title }), width: 400, height: 300, src: address });
    image.addEventListener("error", showNone);
    frame.append(image);
  } else showNone();
  return frame;
}
