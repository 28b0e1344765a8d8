import { useRef, type ReactNode } from 'react';
import type { Scene } from '@/generated/messages';
import { Surroundings, useSight, type Orbit } from '@/features/viewer/scene/Surroundings';
import type { Pictures } from '@/features/viewer/scene/TextureCache';
import { hasWebGl } from '@/features/viewer/webgl';
import { useVisible } from '@/ui/hooks/useVisible';
import classes from '../editor3d.module.css';
import { Canvas3d } from './EditorCanvas';
import type { ThingScene } from './ThingScene';

interface Picture3dProps {
  readonly label: string;
  readonly near: number;
  readonly stage: (isDark: boolean) => ReactNode;
}

/** A picture of a document in 3D, which the pointer turns; nothing where there is no WebGL. */
export function Picture3d({ label, near, stage }: Picture3dProps) {
  const view = useRef<HTMLDivElement>(null);
  const isVisible = useVisible(view);
  if (!hasWebGl()) return null;
  return (
    <div ref={view} className={classes['picture']} role="img" aria-label={label} data-testid="picture-3d">
      <Canvas3d isVisible={isVisible} near={near} stage={stage} />
    </div>
  );
}

interface PictureStageProps {
  readonly scene: ThingScene<{ readonly key: string }>;
  /** How many meshes and textures have arrived: the camera moves, since the whole may be larger. */
  readonly request: number;
  readonly isDark: boolean;
  readonly lights: Scene['lights'];
  readonly ground: { readonly color: readonly number[]; readonly picture?: string | undefined };
  readonly textures?: Pictures;
  readonly reach: readonly [number, number];
  readonly extent: readonly [number, number];
}

/** The 3D content of a document, to be looked at only. */
export function PictureStage({ scene, request, isDark, extent, ...surroundings }: PictureStageProps) {
  const controls = useRef<Orbit | null>(null);
  const [least, most] = extent;
  useSight(controls, request, () => ({ bounds: scene.bounds, kind: 'default', least, most }));
  return (
    <Surroundings {...surroundings} controls={controls} isDark={isDark} bounds={scene.bounds} hasGrid>
      <primitive object={scene.group} />
    </Surroundings>
  );
}
