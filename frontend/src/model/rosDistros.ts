/** The ROS distributions whose Nav2 is known, from the oldest to the newest. */
export const ROS_DISTROS = ['humble', 'jazzy', 'kilted', 'lyrical'] as const;

export type RosDistro = (typeof ROS_DISTROS)[number];

/** That of new projects. */
export const DEFAULT_DISTRO: RosDistro = 'jazzy';

/** Returns a distribution as its users write it. */
export const titled = (name: RosDistro): string => name.charAt(0).toUpperCase() + name.slice(1);
