/** The part of d3-flextree 2 that layoutTree() uses; the package ships no types. */
declare module 'd3-flextree' {
  export interface FlexNode<Data> {
    readonly data: Data;
    readonly x: number;
    readonly y: number;
    readonly children?: readonly FlexNode<Data>[];
    each(visit: (node: FlexNode<Data>) => void): void;
  }
  export interface FlexLayout<Data> {
    (tree: FlexNode<Data>): FlexNode<Data>;
    hierarchy(data: Data): FlexNode<Data>;
  }
  export function flextree<Data>(options: {
    children: (data: Data) => readonly Data[];
    nodeSize: (node: FlexNode<Data>) => [breadth: number, depth: number];
    spacing?: (a: FlexNode<Data>, b: FlexNode<Data>) => number;
  }): FlexLayout<Data>;
}
