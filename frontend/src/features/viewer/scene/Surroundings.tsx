import { OrbitControls } from '@react-three/drei/core/OrbitControls';
import { useThree } from '@react-three/fiber';
import { useEffect, type ComponentRef, type ReactNode, type RefObject } from 'react';
import * as THREE from 'three';
import type { Scene } from '@/generated/messages';
import { framingDistance } from './framing';
import { Ground } from './Ground';
import { Lights } from './Lights';
import type { Pictures } from './TextureCache';
import { isSoftwareWebGl } from '../webgl';

export type Orbit = ComponentRef<typeof OrbitControls>;

const LOOKS = {
  light: { sky: '#e6ebf3', gridMain: '#7c8598', gridLine: '#a3abbb' },
  dark: { sky: '#151922', gridMain: '#8d96a8', gridLine: '#5b6474' },
};

interface SurroundingsProps {
  readonly controls: RefObject<Orbit | null>;
  /** The element whose events turn the view; by default the canvas. */
  readonly element?: HTMLElement | null;
  readonly isDark: boolean;
  readonly lights: Scene['lights'];
  readonly bounds: THREE.Box3;
  readonly ground: { readonly color: readonly number[]; readonly picture?: string | undefined };
  readonly textures?: Pictures | undefined;
  readonly hasGrid: boolean;
  /** The spacing in m of the finer lines around the origin; 1 and 0 mean none. */
  readonly fineGrid?: number;
  /** The nearest and farthest distance of the camera, in m. */
  readonly reach: readonly [number, number];
  readonly children: ReactNode;
}

/** The sky, light, ground, grid and camera controls of every view of a world. */
export function Surroundings(props: SurroundingsProps) {
  const { controls, element, isDark, lights, bounds, ground, textures, hasGrid, fineGrid = 0, reach } = props;
  const isSimple = isSoftwareWebGl();
  const look = isDark ? LOOKS.dark : LOOKS.light;
  const [nearest, farthest] = reach;
  return (
    <>
      <color attach="background" args={[look.sky]} />
      {isSimple ? null : <fog attach="fog" args={[look.sky, farthest / 2, farthest * 1.5]} />}
      <Lights key={lights.length} scene={{ lights }} bounds={bounds} isDark={isDark} hasShadows={!isSimple} />
      <Ground
        color={ground.color}
        picture={ground.picture}
        {...(textures ? { textures } : {})}
        isDark={isDark}
        isSimple={isSimple}
      />
      {hasGrid ? <Grid main={look.gridMain} line={look.gridLine} side={40} step={1} opacity={0.45} /> : null}
      {fineGrid > 0 && fineGrid < 1 ? (
        <Grid
          main={look.gridLine}
          line={look.gridLine}
          side={Math.min(20, fineGrid * 200)}
          step={fineGrid}
          opacity={fineGrid < 0.5 ? 0.22 : 0.3}
        />
      ) : null}
      {props.children}
      <OrbitControls
        ref={controls}
        {...(element ? { domElement: element } : {})}
        makeDefault
        // Damping draws many additional pictures, and with software rendering each takes time from the
        // simulation.
        enableDamping={!isSimple}
        maxPolarAngle={Math.PI / 2 - 0.02}
        minDistance={nearest}
        maxDistance={farthest}
      />
    </>
  );
}

interface GridProps {
  readonly main: string;
  readonly line: string;
  readonly side: number;
  readonly step: number;
  readonly opacity: number;
}

function Grid({ main, line, side, step, opacity }: GridProps) {
  return (
    <gridHelper
      key={`${main} ${step}`}
      args={[side, Math.round(side / step), main, line]}
      rotation={[Math.PI / 2, 0, 0]}
      position={[0, 0, step < 1 ? 0.003 : 0.0035]}
      material-transparent
      material-opacity={opacity}
    />
  );
}

interface Sight {
  readonly bounds: THREE.Box3;
  /** The smallest visible diagonal, in m; `most` is the largest. */
  readonly least: number;
  readonly most: number;
  readonly kind: 'default' | 'top' | 'selection';
}

/** Moves the camera so that a box is visible: from above, from the side, or from the current direction. */
export function look(
  camera: THREE.Camera,
  controls: Orbit | null,
  { bounds, least, most, kind }: Sight,
): void {
  const center = bounds.isEmpty() ? new THREE.Vector3() : bounds.getCenter(new THREE.Vector3());
  const size = Math.min(Math.max(bounds.getSize(new THREE.Vector3()).length(), least), most);
  if (kind === 'top') center.z = Math.min(0.2, center.z);
  const before = camera.position.clone().sub(controls?.target ?? new THREE.Vector3());
  const side = new THREE.Vector3(-0.62, -0.42, 0.58);
  if (kind === 'default' && !bounds.isEmpty() && camera instanceof THREE.PerspectiveCamera) {
    side.setLength(Math.max(framingDistance(camera, bounds, side), side.length() * least));
  } else side.multiplyScalar(size);
  const offset =
    kind === 'top'
      ? new THREE.Vector3(-0.001, 0, size * 1.05)
      : kind === 'selection'
        ? before.setLength(size * 1.6)
        : side;
  if (controls) rest(controls);
  camera.position.copy(center).add(offset);
  controls?.target.copy(center);
  controls?.update();
}

/** Stops the inertia of a gesture, which would move the camera away from the next view. */
function rest(controls: Orbit): void {
  const { enableDamping } = controls;
  controls.enableDamping = false;
  controls.update();
  controls.enableDamping = enableDamping;
}

/** Moves the camera whenever `request` is another one. */
export function useSight(
  controls: RefObject<Orbit | null>,
  request: object | number,
  sight: () => Sight,
): void {
  const camera = useThree((state) => state.camera);
  const invalidate = useThree((state) => state.invalidate);
  useEffect(() => {
    look(camera, controls.current, sight());
    invalidate();
    // Only a new request moves the camera; a change of the world does not.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [request, camera, controls, invalidate]);
}
