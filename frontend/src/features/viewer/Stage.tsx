import { OrbitControls } from '@react-three/drei/core/OrbitControls';
import { useFrame, useThree } from '@react-three/fiber';
import { useEffect, useMemo, useRef, type ComponentRef } from 'react';
import * as THREE from 'three';
import type { Scene } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { forEachPose, type Pose } from '@/store/session/poses';
import { trail } from '@/store/session/trail';
import { Ground } from './Ground';
import { FramesView, FrustumView } from './HelperViews';
import { LidarView } from './LidarView';
import { Lights } from './Lights';
import { MeasureLine } from './MeasureLine';
import { TextureCache } from './TextureCache';
import { TrailView } from './TrailView';
import type { ViewOptions } from './viewOptions';
import { useTools } from './useTools';
import { useThrottledInvalidate } from './useThrottledInvalidate';
import { isSoftwareWebGl } from './webgl';
import { World } from './World';

interface StageProps {
  readonly scene: Scene;
  readonly options: ViewOptions;
  readonly isDark: boolean;
}

const LOOKS = {
  light: { sky: '#e6ebf3', gridMain: '#7c8598', gridLine: '#a3abbb' },
  dark: { sky: '#151922', gridMain: '#8d96a8', gridLine: '#5b6474' },
};

/** What is drawn: the world, its light, and what helps to read it. */
export function Stage({ scene, options, isDark }: StageProps) {
  const isSimple = isSoftwareWebGl();
  const requestFrame = useThrottledInvalidate();
  const textures = useMemo(
    () => new TextureCache(scene.textures ?? {}, requestFrame, isSimple ? 1 : 8),
    [scene, isSimple, requestFrame],
  );
  const world = useMemo(() => new World(scene, isSimple, textures), [scene, isSimple, textures]);
  const lidar = useMemo(() => new LidarView(), []);
  const trailView = useMemo(() => new TrailView(trail), []);
  const framesView = useMemo(() => new FramesView(scene, world), [scene, world]);
  const frustum = useMemo(() => new FrustumView(scene, world), [scene, world]);
  const controls = useRef<ComponentRef<typeof OrbitControls>>(null);
  const look = isDark ? LOOKS.dark : LOOKS.light;

  useEffect(() => () => world.dispose(), [world]);
  useEffect(() => () => lidar.dispose(), [lidar]);
  useEffect(() => () => trailView.dispose(), [trailView]);
  useEffect(() => () => framesView.dispose(), [framesView]);
  useEffect(() => () => frustum.dispose(), [frustum]);
  useEffect(() => {
    framesView.show(options.frames);
    frustum.show(options.frustum);
    requestFrame();
  }, [framesView, frustum, options.frames, options.frustum, requestFrame]);

  useEffect(() => {
    const stopPoses = frames.listen('poses', (frame) => {
      const changed: [number, Pose][] = [];
      forEachPose(frame, (id, pose) => changed.push([id, pose]));
      world.receive(changed, performance.now());
      requestFrame();
    });
    const stopScans = frames.listen('scan', (scan) => {
      lidar.show(scan);
      requestFrame();
    });
    return () => {
      stopPoses();
      stopScans();
    };
  }, [world, lidar, requestFrame]);

  const lastRobot = useRef(new THREE.Vector3());
  useFrame(({ camera }) => {
    const isMoving = world.advance(performance.now());
    if (options.trail) trailView.update();
    if (world.robot) {
      if (options.follow && controls.current) {
        const step = world.robot.position.clone().sub(lastRobot.current);
        camera.position.add(step);
        controls.current.target.add(step);
      }
      lastRobot.current.copy(world.robot.position);
    }
    if (isMoving) requestFrame();
  });

  useViewpoint(world, controls, options.viewpoint);
  useTools(world, controls);

  return (
    <>
      <color attach="background" args={[look.sky]} />
      {isSimple ? null : <fog attach="fog" args={[look.sky, 30, 90]} />}
      <Lights scene={scene} bounds={world.bounds} isDark={isDark} hasShadows={!isSimple} />
      <Ground
        color={scene.ground_color}
        picture={scene.ground_texture}
        textures={textures}
        isDark={isDark}
        isSimple={isSimple}
      />
      {options.grid ? (
        <gridHelper
          key={look.gridMain}
          args={[40, 40, look.gridMain, look.gridLine]}
          rotation={[Math.PI / 2, 0, 0]}
          position={[0, 0, 0.003]}
          material-transparent
          material-opacity={0.45}
        />
      ) : null}
      <primitive object={world.group} />
      {options.rays ? <primitive object={lidar.group} /> : null}
      {options.trail ? <primitive object={trailView.line} /> : null}
      {options.frames ? <primitive object={framesView.origin} /> : null}
      <MeasureLine />
      <OrbitControls
        ref={controls}
        makeDefault
        maxPolarAngle={Math.PI / 2 - 0.02}
        minDistance={0.4}
        maxDistance={60}
      />
    </>
  );
}

type Controls = { readonly current: ComponentRef<typeof OrbitControls> | null };

/** Puts the camera where the user asked for it; each request is a new object. */
function useViewpoint(world: World, controls: Controls, viewpoint: ViewOptions['viewpoint']): void {
  const camera = useThree((state) => state.camera);
  const invalidate = useThree((state) => state.invalidate);
  useEffect(() => {
    const center = world.bounds.isEmpty() ? new THREE.Vector3() : world.bounds.getCenter(new THREE.Vector3());
    center.z = 0.2;
    const size = Math.min(Math.max(world.bounds.getSize(new THREE.Vector3()).length(), 4), 24);
    const offset =
      viewpoint.kind === 'top'
        ? new THREE.Vector3(-0.001, 0, size * 1.05)
        : new THREE.Vector3(-0.62 * size, -0.42 * size, 0.55 * size);
    camera.position.copy(center).add(offset);
    controls.current?.target.copy(center);
    controls.current?.update();
    invalidate();
  }, [world, controls, viewpoint, camera, invalidate]);
}
