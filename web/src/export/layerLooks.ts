/** Carries what the layers panel says into exports: hidden layers stay out, the others keep their opacity. */
import type { Scene } from '../api/schema';
import { LAYER_NAMES, type LayerLook, type LayerName } from '../store/edit';

export type LayerLooks = Readonly<Record<LayerName, LayerLook>>;

/** The scene without the paths of hidden layers. */
export function shownScene(scene: Scene, looks: LayerLooks): Scene {
  const { back, fore, local } = looks;
  return {
    ...scene,
    back: back.visible ? scene.back : [],
    fore: fore.visible ? scene.fore : [],
    local: local.visible ? scene.local : [],
  };
}

/** Gives the layer groups of a written SVG their opacity; every SVG of ours has them by these ids. */
export function withOpacities(svg: string, looks: LayerLooks): string {
  return LAYER_NAMES.reduce(
    (text, name) => (looks[name].opacity < 1 ? text.replace(`<g id="${name}"`, `$& opacity="${looks[name].opacity}"`) : text),
    svg,
  );
}

export const areOpaque = (looks: LayerLooks): boolean => LAYER_NAMES.every((name) => !looks[name].visible || looks[name].opacity === 1);
