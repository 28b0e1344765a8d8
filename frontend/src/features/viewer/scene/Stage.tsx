import { useFrame } from '@react-three/fiber';
import { useEffect, useMemo, useRef } from 'react';
import * as THREE from 'three';
import type { Scene } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { forEachPose, type Pose } from '@/store/session/poses';
import { trail } from '@/store/session/trace/trail';
import { FramesView, FrustumView } from './HelperViews';
import { LidarView } from './LidarView';
import { MeasureLine } from './MeasureLine';
import { Surroundings, useSight, type Orbit } from './Surroundings';
import { TextureCache } from './TextureCache';
import { TrailView } from './TrailView';
import type { ViewOptions } from '../viewOptions';
import { useTools } from '../useTools';
import { useThrottledInvalidate } from '../useThrottledInvalidate';
import { isSoftwareWebGl } from '../webgl';
import { World } from './World';

interface StageProps {
  readonly scene: Scene;
  readonly options: ViewOptions;
  readonly isDark: boolean;
}

/** The content of the view: the world, its light, and optional helpers. */
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
  const controls = useRef<Orbit | null>(null);

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

  useSight(controls, options.viewpoint, () => ({
    bounds: world.bounds,
    kind: options.viewpoint.kind,
    least: 4,
    most: 24,
  }));
  useTools(world, controls);

  return (
    <Surroundings
      controls={controls}
      isDark={isDark}
      lights={scene.lights}
      bounds={world.bounds}
      ground={{ color: scene.ground_color, picture: scene.ground_texture }}
      textures={textures}
      hasGrid={options.grid}
      reach={[0.4, 60]}
    >
      <primitive object={world.group} />
      {options.rays ? <primitive object={lidar.group} /> : null}
      {options.trail ? <primitive object={trailView.line} /> : null}
      {options.frames ? <primitive object={framesView.origin} /> : null}
      <MeasureLine />
    </Surroundings>
  );
}
